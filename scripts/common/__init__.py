"""What report.py and paper.py share: readers of a run's files, the paper's values, and how
the figures look."""
