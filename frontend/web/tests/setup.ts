/** Before each file of tests: what one before it has left in their common process is gone. */
import { vi } from "vitest";

vi.useRealTimers();
vi.unstubAllGlobals();
vi.resetModules();
