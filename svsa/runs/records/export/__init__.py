"""Export of records to other file formats."""
