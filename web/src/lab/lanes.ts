// Whether the lanes of plots above the time line are open, and whether they are large.

import { createChoice } from '../ui/storage';

const [lanes, choose] = createChoice('lanes', ['closed', 'open']);
const [size, chooseSize] = createChoice('lane-size', ['small', 'large']);

export const hasLanes = (): boolean => lanes() === 'open';

export function toggleLanes(): void {
  choose(hasLanes() ? 'closed' : 'open');
}

export const hasLargeLanes = (): boolean => size() === 'large';

export function setLargeLanes(isLarge: boolean): void {
  chooseSize(isLarge ? 'large' : 'small');
}
