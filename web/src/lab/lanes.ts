// Whether the lanes of plots above the time line are open.

import { createChoice } from '../ui/storage';

const [lanes, choose] = createChoice('lanes', ['closed', 'open']);

export const hasLanes = (): boolean => lanes() === 'open';

export function toggleLanes(): void {
  choose(hasLanes() ? 'closed' : 'open');
}
