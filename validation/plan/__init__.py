"""What is made: one file for each subject declares its runs of the product, and in EVIDENCE its items."""
