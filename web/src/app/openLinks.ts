// Links to the lesson and the challenge that are open, for each in a session of their own.

import { challengeCopy, lessonCopy } from '../lab/copyLink';
import type { Addressed, Contested } from '../lab/slices';
import type { Shared } from '../features/share/ShareButton';

export function openLinks({ address, contest }: Addressed & Contested): readonly Shared[] {
  const [lesson, challenge] = [address.lesson(), contest.name()];
  const links: Shared[] = [];
  if (lesson !== undefined) {
    links.push({
      title: 'This lesson',
      address: lessonCopy(lesson),
      words: 'For a class: it opens this lesson in a session of each reader’s own.',
    });
  }
  if (challenge !== undefined) {
    links.push({
      title: 'This challenge',
      address: challengeCopy(challenge),
      words: 'Each player has a session of their own; all are on the same board.',
    });
  }
  return links;
}
