"""What a bearing reports beside its film: the least film, and the numbers of the whole bearing."""
