"""The data sets of both levels: curated, sampled, audited."""
