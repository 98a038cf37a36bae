"""Compiled functions: fused multiply-add, SIMD lanes, code cache and own trigonometry."""
