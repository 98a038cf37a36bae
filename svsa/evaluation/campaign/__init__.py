"""What studies, falsifier, tuning, ranking and grading share: parts are run, saved, continued."""
