"""The ladder of the tests themselves stays as it is: what every Python with this folder imports is no module of them."""

collect_ignore = ["sitecustomize.py"]
