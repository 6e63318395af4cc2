import type { Player } from "./player";
export function connect(_ready: (player: Player) => void): void {}
