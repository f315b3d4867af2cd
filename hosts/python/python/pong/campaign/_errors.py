"""Errors of a whole campaign; errors of single runs are among its failures."""

from pong import PongError


class CampaignError(PongError):
    """A campaign cannot begin or continue. Finished runs are kept."""
