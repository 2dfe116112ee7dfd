"""A description whose seeds scatter as the windows of a surface do, judged by windows that the fit has not seen."""
