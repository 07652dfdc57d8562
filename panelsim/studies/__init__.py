"""What is done with cases: a single run with all its files; studies over many runs."""
