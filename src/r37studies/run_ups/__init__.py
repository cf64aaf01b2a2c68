"""Run-ups and run-downs: the speed changes while the blade rubs."""
