"""The ladder of models: kinds of scenes, models, results, and how results are stored."""
