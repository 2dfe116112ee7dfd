"""The ladder of the tests themselves stays as it is: the file that adds a model to others is no module of theirs."""

collect_ignore = ["sitecustomize.py"]
