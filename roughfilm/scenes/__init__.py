"""The keys of scenes as data: a JSON Schema for editors, and annotated scenes to start from."""
