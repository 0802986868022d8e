// Whether this browser opens Ferry for the first time, at its plain address: a link to something else opens that.

import type { Address } from '../lab/address';
import { createChoice } from '../ui/storage';

export function createFirstVisit(address: Address, page: Window) {
  const [visit, setVisit] = createChoice('visit', ['first', 'done']);
  const { search, hash } = page.location;
  const isPlain = (): boolean => address.view() === 'laboratory' && address.lesson() === undefined;
  if (search !== '' || hash !== '' || !isPlain()) setVisit('done');
  return {
    isOpen: (): boolean => visit() === 'first' && isPlain(),
    end: (): void => {
      setVisit('done');
    },
  };
}
