"""The parts of report.py: reading a run's output, figures, words and the page."""
