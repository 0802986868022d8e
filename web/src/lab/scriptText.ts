// Scripted disturbances as text in a link: `displace:-0.19,-0.48@near:0.21,-0.34,0.02;dropout:3@tick:500`. Pure.

import type { Disturbance, Scripted, When } from '../net/protocol.gen';

/** Throws an error with the field, the value, and what is allowed. */
export class TextError extends Error {}

export function refuse(field: string, value: string, allowed: string): never {
  throw new TextError(`${field} is “${value}”; it must be ${allowed}`);
}

const NUMBER = /^-?\d+(\.\d+)?(e[+-]?\d+)?$/;

export function readNumber(field: string, text: string): number {
  const value = NUMBER.test(text) ? Number(text) : NaN;
  return Number.isFinite(value) ? value : refuse(field, text, 'a number');
}

export function readWhole(field: string, text: string): number {
  const value = /^\d+$/.test(text) ? Number(text) : NaN;
  return Number.isSafeInteger(value) ? value : refuse(field, text, 'a whole number, 0 or larger');
}

/** Exactly `count` numbers separated by commas. */
export function readNumbers(field: string, text: string, count: number): number[] {
  const parts = text.split(',');
  if (parts.length !== count) refuse(field, text, `${count} numbers separated by commas`);
  return parts.map((part) => readNumber(field, part));
}

export function readPlace(field: string, text: string): [number, number] {
  const [x = NaN, y = NaN] = readNumbers(field, text, 2);
  return [x, y];
}

function disturbanceText(disturbance: Disturbance): string {
  if ('displace' in disturbance) {
    const { x_m, y_m } = disturbance.displace;
    return `displace:${x_m},${y_m}`;
  }
  if ('impulse' in disturbance) {
    const { x_n_s, y_n_s } = disturbance.impulse;
    return `impulse:${x_n_s},${y_n_s}`;
  }
  if ('drift' in disturbance) {
    const { x_n, y_n, for_s } = disturbance.drift;
    return `drift:${x_n},${y_n},${for_s}`;
  }
  return `dropout:${disturbance.dropout.for_s}`;
}

function whenText(at: When): string {
  if ('tick' in at) return `tick:${at.tick}`;
  if ('step' in at) return `step:${at.step}`;
  if ('passes_x_m' in at) return `passes_x:${at.passes_x_m}`;
  const { x_m, y_m, within_m } = at.near;
  return `near:${x_m},${y_m},${within_m}`;
}

export function scriptText(script: readonly Scripted[]): string {
  return script
    .map(({ at, disturbance }) => `${disturbanceText(disturbance)}@${whenText(at)}`)
    .join(';');
}

/** The text before and after the first `mark`. */
export function halves(text: string, mark: string): readonly [string, string | undefined] {
  const at = text.indexOf(mark);
  return at < 0 ? [text, undefined] : [text.slice(0, at), text.slice(at + mark.length)];
}

function readDisturbance(field: string, text: string): Disturbance {
  const [kind, values = ''] = halves(text, ':');
  switch (kind) {
    case 'displace': {
      const [x_m, y_m] = readPlace(field, values);
      return { displace: { x_m, y_m } };
    }
    case 'impulse': {
      const [x_n_s, y_n_s] = readPlace(field, values);
      return { impulse: { x_n_s, y_n_s } };
    }
    case 'drift': {
      const [x_n = NaN, y_n = NaN, for_s = NaN] = readNumbers(field, values, 3);
      return { drift: { x_n, y_n, for_s } };
    }
    case 'dropout':
      return { dropout: { for_s: readNumber(field, values) } };
    default:
      return refuse(field, text, 'displace, impulse, drift or dropout with its numbers');
  }
}

function readWhen(field: string, text: string): When {
  const [kind, values = ''] = halves(text, ':');
  switch (kind) {
    case 'tick':
      return { tick: readWhole(field, values) };
    case 'step':
      return { step: readWhole(field, values) };
    case 'passes_x':
      return { passes_x_m: readNumber(field, values) };
    case 'near': {
      const [x_m = NaN, y_m = NaN, within_m = NaN] = readNumbers(field, values, 3);
      return { near: { x_m, y_m, within_m } };
    }
    default:
      return refuse(field, text, 'tick, step, passes_x or near with its numbers');
  }
}

export function readScript(field: string, text: string): Scripted[] {
  return text.split(';').map((entry) => {
    const [what, at] = halves(entry, '@');
    if (at === undefined) return refuse(field, entry, 'a disturbance, @, and when it happens');
    return { at: readWhen(field, at), disturbance: readDisturbance(field, what) };
  });
}
