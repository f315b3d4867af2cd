"""What goes wrong with a campaign as a whole; what goes wrong in one run is in its failures."""

from pong import PongError


class CampaignError(PongError):
    """A campaign that cannot begin or go on. What was finished is kept."""
