"""What scripts/compare-answers consists of; its help says what is compared and how closely."""
