/** A WebSocket that detects silence and reconnects automatically. */

/** What an ordinary request finds where the stream was lost. */
/** ended: the server lives, but what was streamed is there no more. */
export type Finding = "up" | "down" | "locked" | "ended";
export type Phase = "connecting" | "live" | "lost" | "locked" | "ended";

interface StreamHandlers {
  onPhase(phase: Phase): void;
  onText(message: string): void;
  onBinary(message: ArrayBuffer): void;
}

const SILENCE_MS = 5000;
const SOON_MS = 600;

/** Wait before attempt `attempt` (0, 1, …), ms: doubles from 0.5 s to 4 s, spread by ±20 %. */
export function backoffMs(attempt: number, random: number = Math.random()): number {
  const wait = Math.min(4000, 500 * 2 ** attempt);
  return wait * (0.8 + 0.4 * random);
}

export class StreamConnection {
  #socket: WebSocket | null = null;
  #attempt = 0;
  /** What never came cannot have been lost. */
  #wasLive = false;
  #retryTimer: ReturnType<typeof setTimeout> | undefined;
  #silenceTimer: ReturnType<typeof setTimeout> | undefined;

  /**
   * @param address where the stream is
   * @param probe asked after a failure, because a WebSocket does not tell why it was refused
   */
  constructor(
    private readonly address: () => URL,
    private readonly probe: () => Promise<Finding>,
    private readonly handlers: StreamHandlers,
  ) {}

  open(): void {
    clearTimeout(this.#retryTimer);
    this.#drop();
    const socket = new WebSocket(this.address());
    socket.binaryType = "arraybuffer";
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => this.#receive(event.data);
    socket.onclose = () => void this.#recover();
    this.#socket = socket;
    this.#listenForSilence();
  }

  /** Tries at once when it was waiting: the network or the page has just come back. */
  hurry(): void {
    if (this.#socket === null) this.open();
  }

  /** Tells the server something now, or not at all: what would wait in line is left out. */
  say(words: string): void {
    const socket = this.#socket;
    if (socket?.readyState === WebSocket.OPEN && socket.bufferedAmount === 0) socket.send(words);
  }

  #receive(data: string | ArrayBuffer): void {
    this.#attempt = 0;
    this.#wasLive = true;
    this.#listenForSilence();
    this.handlers.onPhase("live");
    if (typeof data === "string") this.handlers.onText(data);
    else this.handlers.onBinary(data);
  }

  #listenForSilence(): void {
    clearTimeout(this.#silenceTimer);
    this.#silenceTimer = setTimeout(() => void this.#recover(), SILENCE_MS);
  }

  async #recover(): Promise<void> {
    this.#drop();
    if (this.#wasLive) this.handlers.onPhase("lost");
    const finding = await this.probe();
    const isOpenAgain = this.#socket !== null;
    if (isOpenAgain) return;
    if (finding === "locked" || finding === "ended") {
      this.handlers.onPhase(finding);
      return;
    }
    const wait = backoffMs(this.#attempt++);
    clearTimeout(this.#retryTimer);
    this.#retryTimer = setTimeout(
      () => this.open(),
      finding === "up" ? Math.min(wait, SOON_MS) : wait,
    );
  }

  #drop(): void {
    clearTimeout(this.#silenceTimer);
    if (this.#socket === null) return;
    this.#socket.onmessage = null;
    this.#socket.onclose = null;
    this.#socket.close();
    this.#socket = null;
  }
}
