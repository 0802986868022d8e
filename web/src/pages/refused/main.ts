// The page in place of one that was refused: the colours are the person's.

import { createTheme } from '../../ui/theme';

createTheme();
