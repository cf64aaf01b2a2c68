"""What makes the tables and pictures of the pages. Each subject is a module; a rule of validation/rules runs its functions."""
