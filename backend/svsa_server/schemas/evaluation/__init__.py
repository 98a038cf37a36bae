"""Bodies of the routes of ranking, studies, falsifications and tunings."""
