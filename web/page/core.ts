// The page's side of the core: two workers, so that long work never delays the answer to a drag.
import type { Fault, Replied } from './replies';

/** Bad input: one fault for each value. */
export class InputError extends Error {
  constructor(readonly faults: Fault[]) {
    super(faults.map((fault) => `${fault.path} = ${fault.value}: ${fault.permitted}`).join('\n'));
  }
}

/** The work was given up for newer work. */
export class Overtaken extends Error {}

type Report = (share: number) => void;

interface Waiting {
  id: number;
  resolve: (replied: Replied<unknown>) => void;
  reject: (error: Error) => void;
  report: Report | undefined;
}

/** One worker and the request that it is at. */
class Lane {
  private worker: Worker | null = null;
  private waiting: Waiting | null = null;
  private static last = 0;

  constructor(
    private readonly start: () => Worker,
    private readonly wasm: Promise<WebAssembly.Module>,
  ) {}

  get isBusy(): boolean {
    return this.waiting !== null;
  }

  async ask<T>(request: object, report?: Report): Promise<Replied<T>> {
    this.giveUp();
    const id = ++Lane.last;
    const answered = new Promise<Replied<unknown>>((resolve, reject) => {
      this.waiting = { id, resolve, reject, report };
    });
    try {
      const wasm = await this.wasm;
      if (this.waiting?.id === id) this.running(wasm).postMessage({ id, request });
    } catch (error) {
      this.waiting = null;
      throw error;
    }
    return (await answered) as Replied<T>;
  }

  /** Ends the work at hand. A worker cannot be interrupted otherwise; a new one starts at once. */
  giveUp(): void {
    if (!this.waiting) return;
    const { reject } = this.waiting;
    this.waiting = null;
    this.worker?.terminate();
    this.worker = null;
    reject(new Overtaken());
  }

  private running(wasm: WebAssembly.Module): Worker {
    if (this.worker) return this.worker;
    const worker = this.start();
    worker.onmessage = (message) => this.take(message.data);
    worker.onerror = (event) => this.fail(event.message || 'the worker could not start');
    worker.postMessage({ wasm });
    this.worker = worker;
    return worker;
  }

  private take(data: { id: number; share?: number; broken?: string; reply?: any; numbers: Float64Array }): void {
    if (data.broken !== undefined) return this.fail(data.broken);
    const waiting = this.waiting;
    if (!waiting || waiting.id !== data.id) return;
    if (data.share !== undefined) return waiting.report?.(data.share);
    this.waiting = null;
    const { reply, numbers } = data;
    if (reply.faults) waiting.reject(new InputError(reply.faults));
    else if (reply.failure) waiting.reject(new Error(reply.failure));
    else waiting.resolve({ reply, numbers });
  }

  /** A core that ran out of memory, or broke, is replaced. */
  private fail(why: string): void {
    const waiting = this.waiting;
    this.waiting = null;
    this.worker?.terminate();
    this.worker = null;
    waiting?.reject(new Error(/memory|OOM|bad_alloc/i.test(why) ? 'this drive needs more memory than the page has' : why));
  }
}

export class Core {
  readonly quick: Lane;
  readonly thorough: Lane;

  constructor(start: () => Worker, wasm: Promise<WebAssembly.Module>) {
    this.quick = new Lane(start, wasm);
    this.thorough = new Lane(start, wasm);
  }
}
