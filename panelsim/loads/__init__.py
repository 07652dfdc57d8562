"""The loads on the ship, one a file; together they make M η̈."""
