"""What scripts/validate is made of: cases, their runs, and the page of figures."""
