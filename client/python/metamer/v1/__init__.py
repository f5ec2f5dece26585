"""The messages of proto/metamer/v1: protoc writes them here when the package is built."""
