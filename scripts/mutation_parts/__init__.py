"""What scripts/mutate is made of: the mutants of a text, and a tree in which they are tried."""
