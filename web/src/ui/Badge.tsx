// A state as icon and word.

import type { JSX } from 'solid-js';
import type { IconNode } from 'lucide';
import { Icon } from './Icon';
import './Badge.css';

export function Badge(props: {
  of: IconNode;
  tone?: 'good' | 'bad' | 'plain';
  class?: string;
  children: JSX.Element;
}): JSX.Element {
  return (
    <span class={`badge ${props.class ?? ''}`} data-tone={props.tone}>
      <Icon of={props.of} />
      {props.children}
    </span>
  );
}
