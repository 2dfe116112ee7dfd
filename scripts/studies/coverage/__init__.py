"""Coverage of the stated uncertainties: answers to random scenes compared with independent solutions."""
