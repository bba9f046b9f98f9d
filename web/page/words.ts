// The sentences about an answer.
import { InputError } from './core';
import { short } from './numbers';
import type { AnswerReply, Fault } from './replies';

export const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

/** "drive.toml:13:1: load.mass = 1 kg is not a key of [load]". */
const faultText = ({ where, path, value, permitted }: Fault): string =>
  `${where ? `${where}: ` : ''}${path}${value ? `${path ? ' = ' : ''}${value}` : ''} ${permitted}`;

export const wordsOf = (error: unknown): string =>
  error instanceof InputError
    ? error.faults.map(faultText).join('; ')
    : error instanceof Error
      ? error.message
      : String(error);

/** A bound is rounded up. */
function roundedUp(bound: number): number {
  const shown = Number(bound.toPrecision(4));
  if (shown >= bound || bound <= 0) return shown;
  return Number((shown + 10 ** (Math.floor(Math.log10(bound)) - 3)).toPrecision(4));
}

/** Of a closed form: small motion grows, or dies out. */
export function growthText(reply: AnswerReply): string {
  const growth = reply.answer.growth_at_rest;
  if (growth === null) return '';
  return `Growth at rest ${growth === Infinity ? '∞' : short(growth)}. `;
}

export function ceilingText(reply: AnswerReply): string {
  const { ceiling } = reply.answer;
  if (!ceiling) return '';
  if (ceiling.load === null) return `No ceiling: ${ceiling.reason ?? 'none is proved'}.`;
  const condition = ceiling.is_below_limit ? ', as long as the torque stays below its limit' : '';
  return `Ceiling, proved: in the end the load swings by at most ±${short(roundedUp(ceiling.load / reply.unit_in_si))} ${reply.unit}, whatever happens in the gap${condition}.`;
}

export function levelText(reply: AnswerReply): string {
  const found = {
    'closed form': 'computed in closed form',
    'proof by energy': 'proved by energy, without following a motion',
    followed: 'followed from the answer before',
    'one start': 'by following one motion',
    search: 'searched from many starts',
  }[reply.means];
  if (reply.level === 'coarse') return `Coarse, while you change it: ${found}.`;
  const verdict = reply.answer.certainty;
  const isProved = reply.means === 'closed form' && (verdict === 'theorem' || verdict === 'enclosed');
  return `Fine: ${found}${isProved ? ', and proved' : ''}.${reply.is_complete ? '' : ' The search was stopped before its end.'}`;
}
