"""Parts that the studies of validation/ share."""
