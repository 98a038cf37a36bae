"""Ranking, studies, falsifications and tunings."""
