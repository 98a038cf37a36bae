"""Values and files that users give: checked, with units, limits and clear errors."""
