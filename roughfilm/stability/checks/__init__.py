"""How an answer is judged: exact solutions, conservation, invariants."""
