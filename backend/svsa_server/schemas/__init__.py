"""Requests and answers of the API as immutable models."""
