"""What is different between two models, in words of the model: `swarmc diff`."""
