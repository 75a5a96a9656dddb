"""Three growth laws compared on one shoot under its weight: docs/three_growth_models.md."""
