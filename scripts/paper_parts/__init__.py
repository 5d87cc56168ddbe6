"""What scripts/paper.py makes doc/paper/ of."""
