// The page's data and actions in slices. Each function names the slices that it uses.

import type { Accessor } from 'solid-js';
import type { Picture } from '../net/connection';
import type { EndFact, EventMessage } from '../net/protocol.gen';
import type { Address } from './address';
import type { Basis } from './basis';
import type { Catalog } from './catalog';
import type { Comparison } from './comparison';
import type { Contest } from './contest';
import type { Edits } from './edits';
import type { Vec2 } from './geometry';
import type { History } from './history';
import type { Layers } from './layers';
import type { Model } from './model';
import type { MovedWalls } from './movedWalls';
import type { Panels } from './panels';
import type { Place } from './places';
import type { Sight } from './sight';
import type { Steering } from './steering';

export type { Layers, Panels };

/** The session of this page, and what may be sent to it. */
export interface Session extends Pick<
  Basis,
  'session' | 'connection' | 'hello' | 'canOperate' | 'send' | 'stream'
> {
  /** Why the session ended, if it has. */
  readonly ended: Accessor<EndFact | undefined>;
  /** Whether the connection is new and the control that this page had before comes back. */
  isReturning(): boolean;
  /** The lists of the server. */
  readonly catalog: Catalog;
}

export interface Trial extends Pick<Basis, 'scene' | 'state'> {
  readonly goal: Accessor<Vec2 | undefined>;
  readonly history: History;
  readonly edits: Edits;
  /** Grows when the server has released a bead because it received nothing from the hand. */
  readonly silences: Accessor<number>;
}

export interface Events {
  readonly log: Accessor<Model['log']>;
  readonly marks: Accessor<Model['marks']>;
  /** The event whose story is open. */
  readonly inspected: Accessor<EventMessage | undefined>;
  /** Opens the story of an event in its panel; undefined closes it. */
  inspect(event: EventMessage | undefined): void;
}

export interface Notices extends Pick<Basis, 'notify'> {
  readonly notices: Accessor<Model['notices']>;
  dismiss(place: Place, id: number): void;
}

/** What the camera and the controllers see. */
export interface Pictures {
  readonly camera: Accessor<Picture | undefined>;
  readonly observation: Accessor<Picture | undefined>;
  readonly overlay: Accessor<Model['overlay']>;
  readonly obstacleMap: Accessor<Model['obstacleMap']>;
}

export interface ByHand {
  readonly steering: Steering;
  /** How much of the table the page shows. */
  readonly sight: Accessor<Sight>;
  setSight(sight: Sight): void;
}

export interface Walls {
  /** The walls where they are now; undefined while they are at rest. It is the same object that has moved. */
  readonly movedWalls: Accessor<MovedWalls | undefined>;
}

export interface Contested {
  readonly contest: Contest;
}

export interface Compared {
  readonly comparison: Comparison;
}

export interface Addressed {
  readonly address: Address;
}

export interface Lab
  extends
    Session,
    Trial,
    Events,
    Notices,
    Pictures,
    ByHand,
    Walls,
    Contested,
    Compared,
    Layers,
    Addressed,
    Panels {}
