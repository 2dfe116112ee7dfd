"""What an output may replace, and scratch files that end with their process."""
