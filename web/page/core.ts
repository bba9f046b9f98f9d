// The page's side of the core: two workers, so that long work never delays the answer to a drag.
import type { Parts } from './parts';
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
  resolve: (replied: Replied<unknown>) => void;
  reject: (error: Error) => void;
  report: Report | undefined;
}

interface Message {
  id: number;
  share?: number;
  broken?: string;
  reply?: { faults?: Fault[]; failure?: string };
  numbers: Float64Array;
}

/** One worker, which answers requests in their order. */
export class Lane {
  private worker: Worker | null = null;
  private readonly waiting = new Map<number, Waiting>();
  private static last = 0;

  constructor(private readonly parts: Promise<Parts>) {}

  async ask<T>(request: object, report?: Report): Promise<Replied<T>> {
    const parts = await this.parts;
    const id = ++Lane.last;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve: (replied) => resolve(replied as Replied<T>), reject, report });
      this.running(parts).postMessage({ id, request });
    });
  }

  /** Ends the work at hand. A worker cannot be interrupted otherwise; the next request starts a new one. */
  giveUp(): void {
    if (this.waiting.size > 0) this.end(new Overtaken());
  }

  private running({ wasm, startWorker }: Parts): Worker {
    if (this.worker) return this.worker;
    const worker = startWorker();
    worker.onmessage = (message) => this.take(message.data as Message);
    worker.onerror = (event) => this.end(new Error(event.message || 'the worker could not start'));
    worker.postMessage({ wasm });
    this.worker = worker;
    return worker;
  }

  private take(message: Message): void {
    // A core that ran out of memory, or broke, is replaced.
    if (message.broken !== undefined) {
      const isMemory = /memory|OOM|bad_alloc/i.test(message.broken);
      return this.end(new Error(isMemory ? 'This drive needs more memory than the page has.' : message.broken));
    }
    const waiting = this.waiting.get(message.id);
    if (!waiting) return;
    if (message.share !== undefined) return waiting.report?.(message.share);
    this.waiting.delete(message.id);
    const reply = message.reply!;
    if (reply.faults) waiting.reject(new InputError(reply.faults));
    else if (reply.failure) waiting.reject(new Error(reply.failure));
    else waiting.resolve({ reply, numbers: message.numbers });
  }

  private end(error: Error): void {
    const all = [...this.waiting.values()];
    this.waiting.clear();
    this.worker?.terminate();
    this.worker = null;
    for (const { reject } of all) reject(error);
  }
}

export interface Core {
  /** Answers: the next one is followed from the last. */
  answers: Lane;
  /** Maps and changes, which take longer. */
  studies: Lane;
}

/** The work, with its progress and a button to stop where it takes longer than a moment. */
export async function patiently<T>(lane: Lane, request: object): Promise<Replied<T>> {
  const bar = document.getElementById('progress') as HTMLProgressElement;
  const stop = document.getElementById('stop')!;
  const moment = 600; // ms
  const late = setTimeout(() => {
    bar.removeAttribute('value');
    bar.hidden = stop.hidden = false;
  }, moment);
  try {
    return await lane.ask<T>(request, (share) => (bar.value = share));
  } finally {
    clearTimeout(late);
    bar.hidden = stop.hidden = true;
  }
}
