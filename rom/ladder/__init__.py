"""The ladder of models: kinds of scenes, models, requests, results, and the files of results."""
