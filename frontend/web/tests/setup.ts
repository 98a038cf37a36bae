/** Before each file of tests: remove the state that earlier files left in the common process. */
import { vi } from "vitest";

vi.useRealTimers();
vi.unstubAllGlobals();
vi.resetModules();
