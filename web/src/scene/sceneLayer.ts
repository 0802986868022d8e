// The objects that a layer adds to the 3-D scene, besides its picture on the floor.

import type { Object3D } from 'three';
import type { History } from '../lab/history';
import type { SceneMessage, StateMessage } from '../net/protocol.gen';
import type { Paints } from './paints';

export interface SceneObject {
  readonly object: Object3D;
  /** Called with every state while the layer is shown. */
  place(state: StateMessage, history: History): void;
}

export type CreateSceneObject = (paints: Paints, scene: SceneMessage) => SceneObject;

export interface LoadedLayer {
  readonly id: string;
  readonly create: CreateSceneObject;
}

export interface InScene {
  /** Loaded with the 3-D view, which is large. */
  readonly sceneObject?: () => Promise<CreateSceneObject>;
}
