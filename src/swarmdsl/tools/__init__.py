"""Commands about models beside the pipeline."""
