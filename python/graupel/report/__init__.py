"""Report of a run, and comparison of several: figures, words, tables and the page."""
