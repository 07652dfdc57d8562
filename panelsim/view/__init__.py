"""What people look at: plots, report pages and recordings, all made from a history."""
