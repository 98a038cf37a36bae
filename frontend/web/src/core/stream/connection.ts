/**
 * A WebSocket that detects silence and reconnects automatically. A browser reports complete messages
 * only: the server sends small ones, so that the next one is soon complete on a slow link, too.
 */

/**
 * Result of an ordinary request after the stream was lost. ended: the server answers, but the
 * streamed session no longer exists. blocked: the server answers, but its sessions do not.
 */
export type ProbeResult = "up" | "down" | "locked" | "ended" | "blocked";
/**
 * slow: connected, but nothing has arrived for a while, or no sample yet. busy: the same, because
 * the sessions of the server do not respond; blocked: after a longer time, when their state is
 * unknown.
 */
export type Phase =
  | "connecting"
  | "live"
  | "slow"
  | "busy"
  | "lost"
  | "blocked"
  | "locked"
  | "ended";

interface StreamHandlers {
  onPhase(phase: Phase): void;
  onText(message: string): void;
  onBinary(message: ArrayBuffer): void;
}

const SLOW_TIMEOUT_MS = 2000;
/** Time to find out whether the link or the server is slow. */
const REASON_TIMEOUT_MS = 500;
const SILENCE_TIMEOUT_MS = 5000;
const SHORT_RETRY_MS = 600;

/** Delay before attempt `attempt` (0, 1, …), ms: doubles from 0.5 s to 4 s, randomised by ±20 %. */
export function backoffMs(attempt: number, random: number = Math.random()): number {
  const wait = Math.min(4000, 500 * 2 ** attempt);
  return wait * (0.8 + 0.4 * random);
}

export class StreamConnection {
  #socket: WebSocket | null = null;
  #attempt = 0;
  /** Whether a connection existed, which can be lost. */
  #wasLive = false;
  /** Whether it is silent, and another connection is tried. */
  #isLost = false;
  /** Whether nothing has arrived since it was lost, also by another connection. */
  #isRecovering = false;
  /** Whether the server answered then, and its sessions did not. */
  #isBlocked = false;
  #retryTimer: ReturnType<typeof setTimeout> | undefined;
  #slowTimer: ReturnType<typeof setTimeout> | undefined;
  #silenceTimer: ReturnType<typeof setTimeout> | undefined;

  /**
   * @param address address of the stream
   * @param probe called after a failure, because a WebSocket does not report why it was rejected
   * @param areSessionsSilent called when nothing arrives: whether the server reports that its
   * sessions do not respond
   */
  constructor(
    private readonly address: () => URL,
    private readonly probe: () => Promise<ProbeResult>,
    private readonly areSessionsSilent: () => Promise<boolean>,
    private readonly handlers: StreamHandlers,
  ) {}

  open(): void {
    clearTimeout(this.#retryTimer);
    this.#drop();
    this.#isLost = false;
    const socket = new WebSocket(this.address());
    socket.binaryType = "arraybuffer";
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => this.#receive(event.data);
    socket.onclose = () => {
      this.#drop();
      void this.#recover();
    };
    this.#socket = socket;
    this.#listenForSilence();
  }

  /** Retry at once if it was waiting: the network or the page is available again. */
  retryNow(): void {
    if (this.#socket === null || this.#isLost) this.open();
  }

  /** Send a message now or drop it: a queued message would arrive too late. */
  send(message: string): void {
    const socket = this.#socket;
    if (socket?.readyState === WebSocket.OPEN && socket.bufferedAmount === 0) socket.send(message);
  }

  #receive(data: string | ArrayBuffer): void {
    this.#attempt = 0;
    this.#wasLive = true;
    // A link that was silent for a while continues with the same connection.
    this.#isLost = this.#isRecovering = this.#isBlocked = false;
    clearTimeout(this.#retryTimer);
    this.#listenForSilence();
    if (typeof data === "string") this.handlers.onText(data);
    else this.handlers.onBinary(data);
    this.handlers.onPhase("live");
  }

  #listenForSilence(): void {
    this.#endSlowTimer();
    clearTimeout(this.#silenceTimer);
    this.#slowTimer = setTimeout(() => void this.#explainSilence(), SLOW_TIMEOUT_MS);
    this.#silenceTimer = setTimeout(() => void this.#recover(), SILENCE_TIMEOUT_MS);
  }

  async #explainSilence(): Promise<void> {
    if (!this.#wasLive || this.#isRecovering) return;
    const timer = setTimeout(() => this.handlers.onPhase("slow"), REASON_TIMEOUT_MS);
    this.#slowTimer = timer;
    const isBlocked = await this.areSessionsSilent();
    if (this.#slowTimer !== timer) return;
    clearTimeout(timer);
    this.#isBlocked = isBlocked;
    this.handlers.onPhase(isBlocked ? "busy" : "slow");
  }

  #endSlowTimer(): void {
    clearTimeout(this.#slowTimer);
    this.#slowTimer = undefined;
  }

  #reportLoss(): void {
    if (this.#wasLive) this.handlers.onPhase(this.#isBlocked ? "blocked" : "lost");
  }

  async #recover(): Promise<void> {
    this.#isLost = this.#isRecovering = true;
    this.#endSlowTimer();
    this.#reportLoss();
    const probeResult = await this.probe();
    if (!this.#isLost) return;
    const isBlocked = probeResult === "blocked";
    if (isBlocked !== this.#isBlocked) {
      this.#isBlocked = isBlocked;
      this.#reportLoss();
    }
    if (probeResult === "locked" || probeResult === "ended") {
      this.#drop();
      this.handlers.onPhase(probeResult);
      return;
    }
    const wait = backoffMs(this.#attempt++);
    clearTimeout(this.#retryTimer);
    this.#retryTimer = setTimeout(
      () => this.open(),
      probeResult === "up" ? Math.min(wait, SHORT_RETRY_MS) : wait,
    );
  }

  #drop(): void {
    this.#endSlowTimer();
    clearTimeout(this.#silenceTimer);
    if (this.#socket === null) return;
    this.#socket.onmessage = null;
    this.#socket.onclose = null;
    this.#socket.close();
    this.#socket = null;
  }
}
