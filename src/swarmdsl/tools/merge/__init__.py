"""Two versions of a file that come from one, merged declaration by declaration: `swarmc merge`."""
