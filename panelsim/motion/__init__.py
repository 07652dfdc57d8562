"""Equations of motion, steppers, and the run that turns them into a history."""
