"""The artifact under review, its repairs, and what is known of the take."""
