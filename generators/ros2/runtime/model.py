"""The model that this package is generated from."""

NAME = ''
VERSION = ''
DIGEST = ''
