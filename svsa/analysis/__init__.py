"""Stability, design, margins and identification."""
