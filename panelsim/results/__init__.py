"""What is read off a history: statistics."""
