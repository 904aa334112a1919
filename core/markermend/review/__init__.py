"""A review: what an operator decides about a take, step by step, undoable and never lost."""
