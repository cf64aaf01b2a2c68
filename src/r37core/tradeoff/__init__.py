"""The price of every approximation: one parameter at a time is varied, errors and costs against a fine value of it."""
