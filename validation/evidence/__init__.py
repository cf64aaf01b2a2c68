"""What makes the tables and pictures of the pages. Each subject is a module; validation/plan says which functions run."""
