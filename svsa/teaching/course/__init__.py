"""The course of the lab: exercises as files, submissions, and the judgement of both."""
