// Converts an experiment to the part of an address after `#`, and back. Pure.
//
// `#v=1&map=colon&controller=errt&seed=7&goal=-0.24,-0.27&threshold_m=0.08`. Missing values are defaults.

import { CONTROLLER_LABELS, FIELDS as FORM_FIELDS } from './parameters';
import {
  halves,
  readNumber,
  readPlace,
  readScript,
  readWhole,
  refuse,
  scriptText,
  TextError,
} from './scriptText';
import type {
  ClientMessage,
  ControllerName,
  Parameters,
  PositionerKind,
  SceneMessage,
  Scripted,
} from '../net/protocol.gen';

export const LINK_VERSION = 1;

export type Place = readonly [number, number];

/** The content of an experiment link. Presets and lessons are such links. */
export interface Experiment {
  readonly map: string;
  readonly controller: ControllerName;
  /** Null for the map's own Positioner. */
  readonly positioner: PositionerKind | null;
  readonly seed: number;
  /** Null for a start chosen by the seed. */
  readonly start_m: Place | null;
  readonly goal_m: Place | null;
  /** Only parameters that differ from their defaults. */
  readonly parameters: Partial<Parameters>;
  /** Number of random disturbances. */
  readonly disturbances: number;
  readonly script: readonly Scripted[];
  /** The map's drawing as text ([`packed`](./drawingLink.ts)), for servers that do not have the map. */
  readonly drawing: string | null;
}

/** Maps, controllers and defaults of this server, to check a link. */
export interface Known extends Pick<SceneMessage, 'controllers' | 'defaults'> {
  readonly maps: readonly string[];
}

/** The parts of an experiment that can change while it runs, from a `StateMessage`. */
export interface Chosen {
  readonly controller: ControllerName;
  readonly goal_m: readonly [number, number, ...number[]] | null;
}

export type Reading =
  | { readonly kind: 'none' }
  | { readonly kind: 'experiment'; readonly experiment: Experiment }
  | { readonly kind: 'broken'; readonly why: string };

const POSITIONERS: readonly PositionerKind[] = ['arm', 'planar_stage'];
/** Fields of a link besides parameters. */
const FIELDS = ['v', 'map', 'controller', 'positioner', 'seed', 'start', 'goal'];
const LAST_FIELDS = ['disturbances', 'script', 'drawing'];

function isParameter(name: string, defaults: Parameters): name is keyof Parameters {
  return Object.hasOwn(defaults, name);
}

/** Parameters that differ from their defaults, in the defaults' order. */
function tuned(parameters: Parameters, defaults: Parameters): Partial<Parameters> {
  const names = Object.keys(defaults) as (keyof Parameters)[];
  const differing = names.filter((name) => parameters[name] !== defaults[name]);
  return Object.fromEntries(differing.map((name) => [name, parameters[name]]));
}

/** Rounds a goal set by the user to 0.1 mm. */
function rounded(goal_m: Place): Place {
  return [Number(goal_m[0].toFixed(4)), Number(goal_m[1].toFixed(4))];
}

/** The trial's setup with the present controller, goal and parameters. */
export function experimentOf(scene: SceneMessage, state: Chosen): Experiment {
  const { scenario } = scene;
  const now = state.goal_m && ([state.goal_m[0], state.goal_m[1]] as const);
  const placed = scenario.goal_m;
  const isAsPlaced = now && placed?.[0] === now[0] && placed[1] === now[1];
  return {
    map: scene.map,
    controller: state.controller,
    positioner: scenario.positioner,
    seed: scene.seed,
    start_m: scenario.start_m,
    goal_m: now && (isAsPlaced ? now : rounded(now)),
    parameters: tuned(scene.parameters, scene.defaults),
    disturbances: scenario.disturbances,
    script: scenario.script,
    drawing: null,
  };
}

/** The link of an experiment with `#`. The same experiment always has the same link. */
export function linkText(experiment: Experiment, defaults: Parameters): string {
  const { positioner, start_m, goal_m, parameters, disturbances, script, drawing } = experiment;
  const pairs: (readonly [string, string])[] = [
    ['v', String(LINK_VERSION)],
    ['map', experiment.map],
    ['controller', experiment.controller],
  ];
  if (positioner !== null) pairs.push(['positioner', positioner]);
  pairs.push(['seed', String(experiment.seed)]);
  if (start_m) pairs.push(['start', start_m.join(',')]);
  if (goal_m) pairs.push(['goal', goal_m.join(',')]);
  for (const name of Object.keys(defaults) as (keyof Parameters)[]) {
    const value = parameters[name];
    if (value !== undefined && value !== defaults[name]) pairs.push([name, String(value)]);
  }
  if (disturbances > 0) pairs.push(['disturbances', String(disturbances)]);
  if (script.length > 0) pairs.push(['script', scriptText(script)]);
  if (drawing !== null) pairs.push(['drawing', drawing]);
  // Separators stay readable, but inside a map's name they are encoded.
  const safe = (name: string, value: string): string =>
    name === 'map' ? encodeURIComponent(value) : value;
  return `#${pairs.map(([name, value]) => `${name}=${safe(name, value)}`).join('&')}`;
}

/** The link of the page's present experiment. */
export function linkOf(scene: SceneMessage, state: Chosen): string {
  return linkText(experimentOf(scene, state), scene.defaults);
}

function oneOf<T extends string>(field: string, value: string, known: readonly T[]): T {
  const found = known.find((name) => name === value);
  return found ?? refuse(field, value, `one of ${known.join(', ')}`);
}

/** A value of the same type as the parameter's default. The server checks the range. */
function readParameter(
  name: keyof Parameters,
  text: string,
  defaults: Parameters,
): Partial<Parameters> {
  if (typeof defaults[name] === 'number') return { [name]: readNumber(name, text) };
  if (typeof defaults[name] === 'boolean') {
    return { [name]: oneOf(name, text, ['true', 'false']) === 'true' };
  }
  const field = FORM_FIELDS.find((one) => one.name === name);
  if (field?.kind !== 'choice') return { [name]: text };
  const choices = field.options.map(([option]) => option);
  return { [name]: oneOf(name, text, choices) };
}

function readDrawing(field: string, text: string): string {
  return /^[\w-]+$/.test(text) ? text : refuse(field, text, 'letters, digits, - and _');
}

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    throw new TextError(`“${text}” is damaged`);
  }
}

/** Names and values, each name once and known. */
function readPairs(text: string, known: Known): ReadonlyMap<string, string> {
  const pairs = new Map<string, string>();
  for (const piece of text.split('&')) {
    const [name, value] = halves(decoded(piece), '=');
    if (value === undefined) throw new TextError(`“${name}” has no value`);
    if (pairs.has(name)) throw new TextError(`${name} appears twice`);
    const isKnown =
      FIELDS.includes(name) || LAST_FIELDS.includes(name) || isParameter(name, known.defaults);
    if (!isKnown) throw new TextError(`“${name}” is not a known name (its value is “${value}”)`);
    pairs.set(name, value);
  }
  return pairs;
}

function readExperiment(pairs: ReadonlyMap<string, string>, known: Known): Experiment {
  const must = (name: string): string => {
    const value = pairs.get(name);
    if (value === undefined) throw new TextError(`${name} is missing`);
    return value;
  };
  const may = <T>(name: string, read: (field: string, text: string) => T): T | null => {
    const value = pairs.get(name);
    return value === undefined ? null : read(name, value);
  };
  let parameters: Partial<Parameters> = {};
  for (const [name, value] of pairs) {
    if (!isParameter(name, known.defaults)) continue;
    parameters = { ...parameters, ...readParameter(name, value, known.defaults) };
  }
  const drawing = may('drawing', readDrawing);
  return {
    // A map with its drawing need not be here.
    map: drawing === null ? oneOf('map', must('map'), known.maps) : must('map'),
    controller: oneOf('controller', must('controller'), known.controllers),
    positioner: may('positioner', (field, text) => oneOf(field, text, POSITIONERS)),
    seed: readWhole('seed', must('seed')),
    start_m: may('start', readPlace),
    goal_m: may('goal', readPlace),
    parameters: tuned({ ...known.defaults, ...parameters }, known.defaults),
    disturbances: may('disturbances', readWhole) ?? 0,
    script: may('script', readScript) ?? [],
    drawing,
  };
}

/** Reads the part of an address after `#`. */
export function experimentFrom(hash: string, known: Known): Reading {
  const text = hash.replace(/^#/, '');
  if (text === '') return { kind: 'none' };
  const version = /^v=([^&]*)/.exec(text)?.[1];
  try {
    if (version === undefined) {
      throw new TextError(`“#${text}” does not start with #v=${LINK_VERSION}`);
    }
    if (version !== String(LINK_VERSION)) {
      throw new TextError(`v is “${version}”; this page reads version ${LINK_VERSION}`);
    }
    return { kind: 'experiment', experiment: readExperiment(readPairs(text, known), known) };
  } catch (error) {
    if (!(error instanceof TextError)) throw error;
    return { kind: 'broken', why: `This experiment link is not valid: ${error.message}.` };
  }
}

/** The command that loads an experiment. */
export function loadMessage(experiment: Experiment, defaults: Parameters): ClientMessage {
  const { map, controller, positioner, seed, start_m, goal_m, disturbances, script } = experiment;
  return {
    type: 'load_scenario',
    map,
    controller,
    seed,
    disturbances,
    script: [...script],
    parameters: { ...defaults, ...experiment.parameters },
    ...(positioner && { positioner }),
    ...(start_m && { start_m: [start_m[0], start_m[1]] }),
    ...(goal_m && { goal_m: [goal_m[0], goal_m[1]] }),
  };
}

export function experimentWords({ map, controller, seed }: Experiment): string {
  return `map ${map}, ${CONTROLLER_LABELS[controller]}, seed ${seed}`;
}
